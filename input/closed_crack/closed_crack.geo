// A plate with a closed crack: two curves in the same place with common end points, each the boundary of one half of the plate. Both halves
// are one body, because they share all other points of the line along which the crack lies.
DefineConstant[ W = {20}, a = {1}, angle = {0.6}, h = {0.04}, order = {2} ];
c = Cos(angle); s = Sin(angle);
Point(1) = {-W, -W, 0, W/8};
Point(2) = { W, -W, 0, W/8};
Point(3) = { W,  W, 0, W/8};
Point(4) = {-W,  W, 0, W/8};
Point(5) = {-W, -W*s/c, 0, W/8};
Point(6) = { W,  W*s/c, 0, W/8};
Point(7) = {-a*c, -a*s, 0, h};  // the tips
Point(8) = { a*c,  a*s, 0, h};
Line(1) = {5, 1};
Line(2) = {1, 2};
Line(3) = {2, 6};
Line(4) = {6, 3};
Line(5) = {3, 4};
Line(6) = {4, 5};
Line(7) = {5, 7};
Line(8) = {8, 6};
Line(9) = {7, 8};   // the lower face of the crack
Line(10) = {7, 8};  // the upper face
Transfinite Curve {9, 10} = 2*a/h + 1;
Curve Loop(1) = {1, 2, 3, -8, -9, -7};
Curve Loop(2) = {4, 5, 6, 7, 10, 8};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Physical Surface("plate") = {1, 2};
Physical Curve("crack_below") = {9};
Physical Curve("crack_above") = {10};
Physical Curve("bottom") = {2};
Physical Curve("top") = {5};
Mesh.ElementOrder = order;
