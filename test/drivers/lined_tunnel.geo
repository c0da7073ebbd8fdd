// rock with a core, a lining, two parts; whole ring (a quarter), all separate bodies
DefineConstant[ W = 30, a = 1, t = 0.1, h = 0.08, order = 2, cut = 1 ];
Point(1)={0,0,0,h}; 
Point(2)={a,0,0,h}; Point(3)={W,0,0,W/10}; Point(4)={W,W,0,W/10}; Point(5)={0,W,0,W/10}; Point(6)={0,a,0,h};
Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,5}; Line(5)={5,6}; Circle(7)={2,1,6};
Curve Loop(1)={2,3,4,5,-7}; Plane Surface(1)={1};
Point(12)={a,0,0,h}; Point(16)={0,a,0,h};
Line(11)={1,12}; Line(16)={16,1}; Circle(17)={12,1,16};
Curve Loop(2)={11,17,16}; Plane Surface(2)={2};
Point(22)={a,0,0,h/2}; Point(26)={0,a,0,h/2}; Point(32)={a-t,0,0,h/2}; Point(36)={0,a-t,0,h/2};
Circle(27)={22,1,26}; Circle(28)={32,1,36}; Line(21)={32,22}; Line(26)={26,36};
Curve Loop(3)={21,27,26,-28}; Plane Surface(3)={3};
Physical Surface("rock")={1}; Physical Surface("core")={2}; Physical Surface("lining")={3};
Physical Curve("left")={5}; Physical Curve("bottom")={2}; Physical Curve("right")={3}; Physical Curve("top")={4};
Physical Curve("core_left")={16}; Physical Curve("core_bottom")={11}; Physical Curve("lining_left")={26}; Physical Curve("lining_bottom")={21};
Physical Curve("wall")={7}; Physical Curve("core_outside")={17}; Physical Curve("lining_outside")={27};Physical Curve("lining_inside")={28};
Mesh.ElementOrder=order;
