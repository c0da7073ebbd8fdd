// A quarter of rock around a circular tunnel, which is a part of it
DefineConstant[ W = 40, a = 1, h = 0.06, order = 2 ];
Point(1)={0,0,0,h}; Point(2)={a,0,0,h}; Point(3)={W,0,0,W/10}; Point(4)={W,W,0,W/10}; Point(5)={0,W,0,W/10}; Point(6)={0,a,0,h};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,5}; Line(5)={5,6}; Line(6)={6,1}; Circle(7)={2,1,6};
Curve Loop(1)={2,3,4,5,-7}; Plane Surface(1)={1};
Curve Loop(2)={1,7,6}; Plane Surface(2)={2};
Physical Surface("rock")={1,2}; Physical Surface("core")={2};
Physical Curve("left")={5,6}; Physical Curve("bottom")={1,2}; Physical Curve("right")={3}; Physical Curve("top")={4};
Mesh.ElementOrder=order;
