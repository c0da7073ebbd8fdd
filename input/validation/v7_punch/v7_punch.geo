// Elastic block under a rigid flat punch of half width 1, right half: x = 0 is a symmetry plane. Lengths in half widths.
//
//      under_punch, block_free
//      +--+---------------+      0 < x < L, -L < y < 0. The elements are small at the edge of the punch, (1, 0), where the pressure is
//      |                  |      infinite, and grow linearly with the distance from it.
//      |      block       |
//      |                  |
//      +------------------+ block_bottom          side at x = 0: block_axis
DefineConstant[ L = {40}, resolution = {40}, edge = {0.1}, order = {1} ];
h = 1 / resolution;

Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {L, 0, 0}; Point(4) = {L, -L, 0}; Point(5) = {0, -L, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};

Field[1] = MathEval;  // edge * h at the edge, h at a distance of 1, proportional to the distance beyond
Field[1].F = Sprintf("%g*(%g+(%g)*Sqrt((x-1)^2+y*y))", h, edge, 1 - edge);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.Algorithm = 6; Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = 0;

Physical Surface("block") = {1};
Physical Curve("under_punch") = {1};
Physical Curve("block_free") = {2};
Physical Curve("block_bottom") = {4};
Physical Curve("block_axis") = {5};
