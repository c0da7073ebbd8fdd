// Slit ring, clearance cl in the slit; squeezed by pressure outside on a part. symmetric about x axis
DefineConstant[ ri = 8, ro = 10, cl = 0.2, h = 0.3, half = 0 ];
Point(1)={0,0,0};
y = cl/2;
xi = Sqrt(ri*ri-y*y); xo = Sqrt(ro*ro-y*y);
Point(2)={xi,y,0,h/2}; Point(3)={xo,y,0,h/2}; Point(4)={0,ro,0,h}; Point(5)={-ro,0,0,h}; Point(6)={0,-ro,0,h};
Point(7)={xo,-y,0,h/2}; Point(8)={xi,-y,0,h/2}; Point(9)={0,-ri,0,h}; Point(10)={-ri,0,0,h}; Point(11)={0,ri,0,h};
Point(12)={ro*Cos(1.2),ro*Sin(1.2),0,h}; Point(13)={ro*Cos(1.2),-ro*Sin(1.2),0,h};
Line(1)={2,3}; Circle(2)={3,1,12}; Circle(3)={12,1,4}; Circle(4)={4,1,5}; Circle(5)={5,1,6}; Circle(6)={6,1,13}; Circle(7)={13,1,7};
Line(8)={7,8}; Circle(9)={8,1,9}; Circle(10)={9,1,10}; Circle(11)={10,1,11}; Circle(12)={11,1,2};
Line(13)={5,10};
Curve Loop(1)={1,2,3,4,13,11,12}; Plane Surface(1)={1};
Physical Curve("upper")={1}; Physical Curve("push_up")={2};
If (half == 0)
  Curve Loop(2)={-13,5,6,7,8,9,10}; Plane Surface(2)={2};
  Physical Surface("ring")={1,2};
  Physical Curve("lower")={8}; Physical Curve("push_down")={7};
Else
  Physical Surface("ring")={1}; Physical Curve("seat")={13};
EndIf
Mesh.ElementOrder=2;
