// A quarter of a plate with a round hole. Lengths in mm; R: radius of the hole, L: half the side of the plate, n: elements on the quarter
// circle.
DefineConstant[ R = {10}, L = {200}, n = {16}, order = {1} ];
h = 0.5 * Pi * R / n;  // size of the elements at the hole
far = L / 20 * 16 / n; // and at the outer sides

Point(1) = {0, 0, 0};
Point(2) = {R, 0, 0, h}; Point(3) = {L, 0, 0, far}; Point(4) = {L, L, 0, far}; Point(5) = {0, L, 0, far}; Point(6) = {0, R, 0, h};
Line(1) = {2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 6}; Circle(5) = {6, 1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Transfinite Curve{5} = n + 1;
Mesh.ElementOrder = order;

// names: the surface is a body, curves are places for conditions
Physical Surface("plate") = {1};
Physical Curve("below") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Curve("hole") = {5};
