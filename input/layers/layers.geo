// Layers of rock crossed by a fault. Units: m.
//
//      +------------------------------------------+ H            six bodies that share no nodes; eight contact
//      |                  top                     |              lines, each side a separate named curve:
//      +-------------------.----------------------+ y3             base_left1, left1_base, ...: "<body>_<neighbour>"
//      |      left2       /        right2         |
//      +-----------------+------------------------+ y2           Three bodies meet at each end of the fault,
//      |      left1     /          right1         |              four in the middle: points where contact pieces meet.
//      +---------------'--------------------------+ y1
//      |                  base                    |              Contact lines have the same nodes on both sides:
//      +------------------------------------------+ 0            elements of equal length (Transfinite).
//      0              xf                          W
//
// The fault passes through (xf, y1), inclined by `tilt` degrees from the vertical (tilt > 0: to the right at the top).
DefineConstant[ W = {120}, y1 = {20}, y2 = {35}, y3 = {50}, H = {60}, xf = {56}, tilt = {15}, a = {70}, b = {95}, h = {1.6}, scale = {1} ];
size = scale*h;
t = Tan(tilt*Pi/180);
x1 = xf; x2 = xf + (y2 - y1)*t; x3 = xf + (y3 - y1)*t;
c = 1/Cos(tilt*Pi/180);
n1l = Round(x1/size); n1r = Round((W - x1)/size);  // elements along the contact lines below, between and above the layers
n2l = Round(x2/size); n2r = Round((W - x2)/size);
n3l = Round(x3/size); n3r = Round((W - x3)/size);
nf1 = Round((y2 - y1)*c/size); nf2 = Round((y3 - y2)*c/size);  // and along the fault

// A body is its corners, counter-clockwise, with one curve between neighbours; curve numbers start at 10, 20, ...
Point(10) = {0, 0, 0, size}; Point(11) = {W, 0, 0, size}; Point(12) = {W, y1, 0, size}; Point(13) = {x1, y1, 0, size}; Point(14) = {0, y1, 0, size};
For i In {10:13}
  Line(i) = {i, i + 1};
EndFor
Line(14) = {14, 10};
Point(20) = {0, y1, 0, size}; Point(21) = {x1, y1, 0, size}; Point(22) = {x2, y2, 0, size}; Point(23) = {0, y2, 0, size};
Point(30) = {x1, y1, 0, size}; Point(31) = {W, y1, 0, size}; Point(32) = {W, y2, 0, size}; Point(33) = {x2, y2, 0, size};
Point(40) = {0, y2, 0, size}; Point(41) = {x2, y2, 0, size}; Point(42) = {x3, y3, 0, size}; Point(43) = {0, y3, 0, size};
Point(50) = {x2, y2, 0, size}; Point(51) = {W, y2, 0, size}; Point(52) = {W, y3, 0, size}; Point(53) = {x3, y3, 0, size};
For k In {2:5}
  For i In {0:3}
    Line(10*k + i) = {10*k + i, 10*k + (i + 1) % 4};
  EndFor
  Curve Loop(k) = {10*k:10*k + 3};
  Plane Surface(k) = {k};
EndFor
Point(60) = {0, y3, 0, size}; Point(61) = {x3, y3, 0, size}; Point(62) = {W, y3, 0, size}; Point(63) = {W, H, 0, size};
Point(64) = {b, H, 0, size}; Point(65) = {a, H, 0, size}; Point(66) = {0, H, 0, size};
For i In {60:65}
  Line(i) = {i, i + 1};
EndFor
Line(66) = {66, 60};
Curve Loop(1) = {10:14}; Plane Surface(1) = {1};
Curve Loop(6) = {60:66}; Plane Surface(6) = {6};

Transfinite Curve{13, 20} = n1l + 1;
Transfinite Curve{12, 30} = n1r + 1;
Transfinite Curve{22, 40} = n2l + 1;
Transfinite Curve{32, 50} = n2r + 1;
Transfinite Curve{42, 60} = n3l + 1;
Transfinite Curve{52, 61} = n3r + 1;
Transfinite Curve{21, 33} = nf1 + 1;
Transfinite Curve{41, 53} = nf2 + 1;
Mesh.Algorithm = 6;

Physical Surface("base") = {1};
Physical Surface("left1") = {2};
Physical Surface("right1") = {3};
Physical Surface("left2") = {4};
Physical Surface("right2") = {5};
Physical Surface("top") = {6};
Physical Curve("bottom") = {10};
Physical Curve("left_side") = {14, 23, 43, 66};
Physical Curve("right_side") = {11, 31, 51, 62};
Physical Curve("load") = {64};
Physical Curve("base_left1") = {13};   Physical Curve("left1_base") = {20};
Physical Curve("base_right1") = {12};  Physical Curve("right1_base") = {30};
Physical Curve("left1_left2") = {22};  Physical Curve("left2_left1") = {40};
Physical Curve("right1_right2") = {32}; Physical Curve("right2_right1") = {50};
Physical Curve("left2_top") = {42};    Physical Curve("top_left2") = {60};
Physical Curve("right2_top") = {52};   Physical Curve("top_right2") = {61};
Physical Curve("left1_right1") = {21}; Physical Curve("right1_left1") = {33};
Physical Curve("left2_right2") = {41}; Physical Curve("right2_left2") = {53};
