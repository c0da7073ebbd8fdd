// Quarter of a clevis joint in mm, with groups named by hand and the barrel of the pin split between rod and lug.
SetFactory("OpenCASCADE");
DefineConstant[ h = 2.5, hc = 1.0, cr = 0.05, cf = 0.02 ];
R = 6;               // pin
te = 6;  tl = 7; g = 0.5;   // half eye thickness, lug, side gap
// rod eye: ring + shank towards -x
Cylinder(1) = {0,0,0, 0,0,te, 13};
Box(2) = {-45,-7,0, 45,14,te};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {0,0,-1, 0,0,te+2, R+cr};
BooleanDifference(5) = { Volume{3}; Delete; }{ Volume{4}; Delete; };
// lug: ring + plate towards +x
Cylinder(6) = {0,0,te+g, 0,0,tl, 13};
Box(7) = {0,-13,te+g, 40,26,tl};
BooleanUnion(8) = { Volume{6}; Delete; }{ Volume{7}; Delete; };
Cylinder(9) = {0,0,te+g-1, 0,0,tl+2, R+cf};
BooleanDifference(10) = { Volume{8}; Delete; }{ Volume{9}; Delete; };
// pin
Cylinder(11) = {0,0,0, 0,0,te+g/2, R}; Cylinder(12) = {0,0,te+g/2, 0,0,g/2+tl+1, R};
// keep y>0
Box(20) = {-60,-60,-1, 120,60,60};
BooleanDifference(30) = { Volume{5}; Delete; }{ Volume{20}; };
BooleanDifference(31) = { Volume{10}; Delete; }{ Volume{20}; };
q() = BooleanDifference{ Volume{11,12}; Delete; }{ Volume{20}; Delete; };
p() = BooleanFragments{ Volume{q()}; Delete; }{};
e = 1e-3;
Physical Volume("rod") = {30};
Physical Volume("lug") = {31};
Physical Volume("pin") = {p()};
rs() = Boundary{ Volume{30}; };
ls() = Boundary{ Volume{31}; };
ps() = CombinedBoundary{ Volume{p()}; };
f() = Surface In BoundingBox{-45-e,-20,-e, -45+e,20,te+e};
f() -= ls();
f() -= ps();
Physical Surface("rod_end") = f();
f() = Surface In BoundingBox{40-e,-20,te+g-e, 40+e,20,te+g+tl+e};
f() -= rs();
f() -= ps();
Physical Surface("lug_end") = f();
f() = Surface In BoundingBox{-46,-20,-e, 14,20,e};
f() -= ls();
f() -= ps();
Physical Surface("rod_z") = f();
f() = Surface In BoundingBox{-46,-e,-e, 14,e,te+e};
f() -= ls();
f() -= ps();
Physical Surface("rod_y") = f();
f() = Surface In BoundingBox{-R-cr-e,-e,-e, R+cr+e,R+cr+e,te+e};
f() -= ls();
f() -= ps();
Physical Surface("eye_hole") = f();
f() = Surface In BoundingBox{-R-cf-e,-e,te+g-e, R+cf+e,R+cf+e,te+g+tl+e};
f() -= rs();
f() -= ps();
Physical Surface("lug_hole") = f();
f() = Surface In BoundingBox{-14,-e,te+g-e, 41,e,te+g+tl+e};
f() -= rs();
f() -= ps();
Physical Surface("lug_y") = f();
Mesh.MeshSizeMax = h;

f() = Surface In BoundingBox{-R-e,-e,-e, R+e,R+e,e};
f() -= rs();
f() -= ls();
Physical Surface("pin_z") = f();
f() = Surface In BoundingBox{-R-e,-e,-e, R+e,e,30};
f() -= rs();
f() -= ls();
Physical Surface("pin_y") = f();
f() = Surface In BoundingBox{-R-e,-e,-e, R+e,R+e,te+g/2+e}; f() -= rs(); f() -= ls(); y() = Surface In BoundingBox{-R-e,-e,-e, R+e,e,30}; z() = Surface In BoundingBox{-R-e,-e,-e, R+e,R+e,e}; m() = Surface In BoundingBox{-R-e,-e,te+g/2-e, R+e,R+e,te+g/2+e};
f() -= y(); f() -= z(); f() -= m(); Physical Surface("pin_low") = f();
f() = Surface In BoundingBox{-R-e,-e,te+g/2-e, R+e,R+e,30}; f() -= rs(); f() -= ls(); t() = Surface In BoundingBox{-R-e,-e,te+g+tl+1-e, R+e,R+e,30};
f() -= y(); f() -= m(); f() -= t(); Physical Surface("pin_high") = f();
Field[1] = Cylinder; Field[1].Radius = 7.5; Field[1].VIn = hc; Field[1].VOut = h; Field[1].ZAxis = 40; 
Background Field = 1;
