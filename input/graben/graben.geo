// Layered rock with two faults: a block between two flanks that narrows downwards. Lengths in m.
//
//    _______ ________________ _______  60
//   |       \   limestone    /       |      Bodies left, block, right: three layers each, surface groups <body>_<layer>.
//   |________\______________/________| 40   Faults are inclined by `lean` degrees: left_fault on block_left,
//   |         \   shale    /         |      block_right on right_fault. The block has no ground below.
//   |__________\__________/__________| 20
//   |           \sandstone/          |
//   |____________\_______/___________| 0
//   0           50       70         120
DefineConstant[ lean = {30}, size = {2}, throw = {6} ];  // throw: how much deeper the layers of the block are
t = Tan(lean * Pi / 180);

// a body: at height y its left and right ends are xl + sl y and xr + sr y
For b In {0:2}
  If (b == 0)
    xl = 0; sl = 0; xr = 50; sr = -t; d = 0;
  ElseIf (b == 1)
    xl = 50; sl = -t; xr = 70; sr = t; d = throw;
  Else
    xl = 70; sl = t; xr = 120; sr = 0; d = 0;
  EndIf
  y[] = {0, 20 - d, 40 - d, 60};
  p = newp; l = newl;
  For k In {0:3}
    Point(p + 2*k) = {xl + sl*y[k], y[k], 0, size}; Point(p + 2*k + 1) = {xr + sr*y[k], y[k], 0, size};
    Line(l + 3*k) = {p + 2*k, p + 2*k + 1};
  EndFor
  For k In {0:2}
    Line(l + 3*k + 1) = {p + 2*k, p + 2*k + 2};      // left end of layer k
    Line(l + 3*k + 2) = {p + 2*k + 1, p + 2*k + 3};  // right end
    w = newll; Curve Loop(w) = {l + 3*k, l + 3*k + 2, -(l + 3*k + 3), -(l + 3*k + 1)};
    s~{k} = news; Plane Surface(s~{k}) = {w};
  EndFor
  If (b == 0)
    Physical Surface("left") = {s_0, s_1, s_2};
    Physical Surface("left_shale") = {s_1}; Physical Surface("left_limestone") = {s_2};
    Physical Curve("left_side") = {l + 1, l + 4, l + 7}; Physical Curve("left_fault") = {l + 2, l + 5, l + 8}; Physical Curve("left_bottom") = {l};
  ElseIf (b == 1)
    Physical Surface("block") = {s_0, s_1, s_2};
    Physical Surface("block_shale") = {s_1}; Physical Surface("block_limestone") = {s_2};
    Physical Curve("block_left") = {l + 1, l + 4, l + 7}; Physical Curve("block_right") = {l + 2, l + 5, l + 8};
  Else
    Physical Surface("right") = {s_0, s_1, s_2};
    Physical Surface("right_shale") = {s_1}; Physical Surface("right_limestone") = {s_2};
    Physical Curve("right_side") = {l + 2, l + 5, l + 8}; Physical Curve("right_fault") = {l + 1, l + 4, l + 7}; Physical Curve("right_bottom") = {l};
  EndIf
EndFor
