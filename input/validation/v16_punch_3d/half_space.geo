// A quarter of a half sphere of radius L that represents the half-space z <= 0: x >= 0, y >= 0. Lengths in units of the scene.
//
//      z = 0   footprint      free          sides: footprint  the disc r < b of the top
//      +----------+-------------+                  free       the rest of the top
//      |                       /                   far        the half sphere
//      |   half_space        _/ far                half_space_x, half_space_y  symmetry planes x = 0 and y = 0
//      |                  _-'
//      +--------------''                    h_disc: element size on the disc, h_edge: at its edge, growing by `growth` with distance.
//
DefineConstant[ L = {8}, b = {1}, h_disc = {0.2}, h_edge = {0.05}, growth = {0.35}, hmax = {2}, order = {2} ];

Point(1) = {0, 0, 0}; Point(2) = {b, 0, 0}; Point(3) = {0, b, 0}; Point(4) = {L, 0, 0}; Point(5) = {0, L, 0}; Point(6) = {0, 0, -L};
Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1};
Line(4) = {2, 4}; Circle(5) = {4, 1, 5}; Line(6) = {5, 3};
Circle(7) = {4, 1, 6}; Circle(8) = {6, 1, 5}; Line(9) = {1, 6};
Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 6, -2}; Plane Surface(2) = {2};
Curve Loop(3) = {7, 8, -5}; Surface(3) = {3} In Sphere {1};
Curve Loop(4) = {9, 8, 6, 3}; Plane Surface(4) = {4};
Curve Loop(5) = {9, -7, -4, -1}; Plane Surface(5) = {5};
Surface Loop(1) = {1:5}; Volume(1) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("Min(%g,Min(%g+%g*Sqrt(Max(0,Sqrt(x*x+y*y)-%g)^2+z*z),%g+%g*Sqrt((Sqrt(x*x+y*y)-%g)^2+z*z)))",
  hmax, h_disc, growth, b, h_edge, growth, b);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;

Physical Volume("half_space") = {1};
Physical Surface("footprint") = {1};
Physical Surface("free") = {2};
Physical Surface("far") = {3};
Physical Surface("half_space_x") = {4};
Physical Surface("half_space_y") = {5};
