// The pin joint of input/pin, upper half, extruded by one layer: one millimetre thick, held at z = 0, free at z = t: nearly plane stress.
// Lengths in mm. A lug with a hole of radius R is pulled over a hollow pin with clearance.
DefineConstant[ R = {10}, clearance = {0.02}, L = {60}, W = {20}, bore = {4}, hl = {1.0}, hp = {0.7}, order = {1} ];
Rp = R - clearance;
// lug: hole of radius R around the origin
Point(1) = {0,0,0};
Point(2) = {R,0,0,hl}; Point(3) = {0,R,0,hl}; Point(4) = {-R,0,0,hl};
Point(5) = {-L,0,0,3*hl}; Point(6) = {-L,W,0,3*hl}; Point(7) = {0,W,0,2*hl}; Point(8) = {W,0,0,2*hl};
Circle(1) = {2,1,3}; Circle(2) = {3,1,4};
Line(3) = {4,5}; Line(4) = {5,6}; Line(5) = {6,7}; Circle(6) = {7,1,8}; Line(7) = {8,2};
Curve Loop(1) = {1,2,3,4,5,6,7}; Plane Surface(1) = {1};
// pin
Point(12) = {Rp,0,0,hp}; Point(13) = {0,Rp,0,hp}; Point(14) = {-Rp,0,0,hp};
Point(15) = {-bore,0,0,hp}; Point(16) = {0,bore,0,hp}; Point(17) = {bore,0,0,hp};
Circle(11) = {12,1,13}; Circle(12) = {13,1,14}; Line(13) = {14,15}; Circle(14) = {15,1,16}; Circle(15) = {16,1,17}; Line(16) = {17,12};
Curve Loop(2) = {11,12,13,14,15,16}; Plane Surface(2) = {2};
t = 1; n = 1;
Mesh.ElementOrder = order;
a[] = Extrude {0,0,t} { Surface{1}; Layers{n}; };
b[] = Extrude {0,0,t} { Surface{2}; Layers{n}; };
Physical Volume("lug") = {a[1]};
Physical Volume("pin") = {b[1]};
Physical Surface("lug_hole") = {a[2],a[3]};
Physical Surface("lug_sym") = {a[4],a[8]};
Physical Surface("lug_end") = {a[5]};
Physical Surface("pin_outside") = {b[2],b[3]};
Physical Surface("pin_sym") = {b[4],b[7]};
Physical Surface("pin_bore") = {b[5],b[6]};
Physical Surface("faces") = {1,2};
