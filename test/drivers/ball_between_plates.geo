// A ball between two plates. Faces of OpenCASCADE: six of each box in the order x, x, y, y, z, z, then the one of the ball.
SetFactory("OpenCASCADE");
DefineConstant[ h = 0.5 ];
Box(1) = {-1.5, -1.5, -1.4, 3, 3, 0.4};
Box(2) = {-1.5, -1.5, 1, 3, 3, 0.4};
Sphere(3) = {0, 0, 0, 1};
north = newp; Point(north) = {0, 0, 1};
south = newp; Point(south) = {0, 0, -1};
Point{north, south} In Surface{13};
Physical Volume("low") = {1};
Physical Volume("high") = {2};
Physical Volume("ball") = {3};
Physical Surface("ground") = {5};
Physical Surface("floor") = {6};
Physical Surface("ceiling") = {11};
Physical Surface("top") = {12};
Physical Surface("skin") = {13};
Mesh.MeshSizeMax = h;
