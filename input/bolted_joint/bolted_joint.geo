// Two round plates, and a bolt in one piece with its nut: axisymmetric about x = 0. Lengths in mm; h: element size.
//
//      x = 0
//      | head  |                         y = clamped + head
//      |_______|______________           y = clamped: head_seat on upper_seat
//      |    |  |              |
//      |    |  |    upper     | upper_rim
//      |    |  |______________|          y = clamped / 2: joint_above on joint_below
//      |    |  |              |
//      |    |  |    lower     | lower_rim
//      |____|__|______________|          y = 0: nut_seat on lower_seat, drawn at y = tighten
//      | nut   |
//      |_______|                         radii: shank, hole, head, plate
DefineConstant[ h = {1, Name "size"}, shank = {5}, hole = {5.5}, head = {8}, plate = {25}, clamped = {30}, head_height = {7}, fillet = {0.4},
  tighten = {0.08} ];  // tightening of the nut beyond first contact: drawn inside the plate
SetFactory("OpenCASCADE");
fine = h / 4;  // at the seats
q = clamped / 2; n = tighten;

// the bolt, with a small fillet under head and nut
Point(1) = {0, n - head_height, 0, h};       Point(2) = {head, n - head_height, 0, h};    Point(3) = {head, n, 0, fine};
Point(4) = {shank + fillet, n, 0, fine};     Point(5) = {shank + fillet, n + fillet, 0};  Point(6) = {shank, n + fillet, 0, fine};
Point(7) = {shank, clamped - fillet, 0, fine}; Point(8) = {shank + fillet, clamped - fillet, 0}; Point(9) = {shank + fillet, clamped, 0, fine};
Point(10) = {head, clamped, 0, fine};        Point(11) = {head, clamped + head_height, 0, h}; Point(12) = {0, clamped + head_height, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Circle(4) = {4, 5, 6}; Line(5) = {6, 7}; Circle(6) = {7, 8, 9};
Line(7) = {9, 10}; Line(8) = {10, 11}; Line(9) = {11, 12}; Line(10) = {12, 1};
Curve Loop(1) = {1:10}; Plane Surface(1) = {1};

// the plates
Point(20) = {hole, 0, 0, fine}; Point(21) = {head, 0, 0, fine}; Point(22) = {plate, 0, 0, 2*h}; Point(23) = {plate, q, 0, 2*h}; Point(24) = {hole, q, 0, h/2};
Point(30) = {hole, clamped, 0, fine}; Point(31) = {head, clamped, 0, fine}; Point(32) = {plate, clamped, 0, 2*h}; Point(33) = {plate, q, 0, 2*h}; Point(34) = {hole, q, 0, h/2};
Line(20) = {20, 21}; Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 20};
Line(30) = {30, 31}; Line(31) = {31, 32}; Line(32) = {32, 33}; Line(33) = {33, 34}; Line(34) = {34, 30};
Curve Loop(2) = {20:24}; Plane Surface(2) = {2};
Curve Loop(3) = {30:34}; Plane Surface(3) = {3};

Physical Surface("bolt") = {1};
Physical Surface("lower") = {2};
Physical Surface("upper") = {3};
Physical Curve("nut_seat") = {3};     Physical Curve("lower_seat") = {20};
Physical Curve("head_seat") = {7};    Physical Curve("upper_seat") = {30};
Physical Curve("joint_below") = {23}; Physical Curve("joint_above") = {33};
Physical Curve("lower_rim") = {22};   Physical Curve("upper_rim") = {32};
Physical Curve("lower_face") = {21};  Physical Curve("upper_face") = {31};
