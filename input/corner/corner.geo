// An angle (L) on a block, which its arm leaves under load. Units: m.
//
//   y = 2   +----+
//           |    |
//   y = 1   |    +----+
//           |  angle  |
//   y = 0   +=========+     contact
//           |  block  |
//   y = -1  +---------+
//          x = 0 1    2
DefineConstant[ h = {0.25} ];
Point(1) = {0, 0, 0, h}; Point(2) = {2, 0, 0, h}; Point(3) = {2, 1, 0, h}; Point(4) = {1, 1, 0, h};
Point(5) = {1, 2, 0, h}; Point(6) = {0, 2, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};

Point(11) = {0, -1, 0, h}; Point(12) = {2, -1, 0, h}; Point(13) = {2, 0, 0, h}; Point(14) = {0, 0, 0, h};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11, 12, 13, 14}; Plane Surface(2) = {2};

Physical Surface("angle") = {1};
Physical Surface("block") = {2};
Physical Curve("angle_top") = {5};
Physical Curve("angle_arm") = {3};
Physical Curve("angle_left") = {6};
Physical Curve("angle_contact") = {1};
Physical Curve("block_contact") = {13};
Physical Curve("block_left") = {14};
Physical Curve("block_bottom") = {11};
