// Lower quarter of a sphere of radius R around (0, 0, R), cut by its symmetry planes x = 0 and y = 0 and by z = R. Scene units.
//
//        z                           sides: ball_contact  the cap r < reach * a around the origin
//        | ball_top                         ball_flank    the rest of the sphere
//      R +-------+ C                        ball_top      z = R
//        |       /                          ball_x, ball_y  symmetry planes x = 0 and y = 0
//        | ball / ball_flank
//        |    _/ A                   h = a / resolution on the cap, growing by `growth` with distance from it;
//      0 +--'  ball_contact          a: contact radius by Hertz' theory
//
DefineConstant[ R = {1}, a = {0.1}, resolution = {8}, reach = {1.4}, growth = {0.3}, hmax = {0.25}, order = {2} ];
h = a / resolution;
e = reach * a; d = R - Sqrt(R*R - e*e);

Point(1) = {0, 0, R};
Point(2) = {0, 0, 0}; Point(3) = {e, 0, d}; Point(4) = {0, e, d}; Point(5) = {R, 0, R}; Point(6) = {0, R, R}; Point(7) = {0, 0, d};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 7, 4}; Circle(3) = {4, 1, 2};    // the cap
Circle(4) = {3, 1, 5}; Circle(5) = {5, 1, 6}; Circle(6) = {6, 1, 4};    // the flank
Line(7) = {5, 1}; Line(8) = {1, 6}; Line(9) = {2, 1};
Curve Loop(1) = {2, 3, 1}; Surface(1) = {1} In Sphere {1};
Curve Loop(2) = {4, 5, 6, -2}; Surface(2) = {2} In Sphere {1};
Curve Loop(3) = {7, 8, -5}; Plane Surface(3) = {3};
Curve Loop(4) = {9, 8, 6, 3}; Plane Surface(4) = {4};
Curve Loop(5) = {1, 4, 7, -9}; Plane Surface(5) = {5};
Surface Loop(1) = {1:5}; Volume(1) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g,%g+%g*Sqrt(Max(0,Sqrt(x*x+y*y)-%g)^2+(%g-Sqrt(x*x+y*y+(z-%g)^2))^2))", hmax * R, h, growth, e, R, R);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;
Mesh.Optimize = 1;

Physical Volume("ball") = {1};
Physical Surface("ball_contact") = {1};
Physical Surface("ball_flank") = {2};
Physical Surface("ball_top") = {3};
Physical Surface("ball_x") = {4};
Physical Surface("ball_y") = {5};
