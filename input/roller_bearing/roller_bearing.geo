// A cylindrical roller bearing, half x > 0: x = 0 is a symmetry plane. Lengths in mm.
//
//        .-""""-.      13 rollers; roller 0 is at the bottom, under the load, and is cut in half; 1 .. 6 follow up to the top.
//      .'  .--.  '.    Side groups: inner_<j> and outer_<j> on shaft and ring, roller_<j>_inner, roller_<j>_outer, and _before, _behind
//     |   |    |   |   where a roller faces its pocket. Each is an arc of +-spot degrees of the roller, or as long on shaft and ring.
//     |   |    |   |   The rollers are drawn in contact with the outer ring, at clearance / 2 from the shaft.
//
DefineConstant[ clearance = {0.02, Name "diametral"}, inner = {30}, roller = {5}, outside = {50}, spot = {5}, h = {1.5, Name "size"}, fine = {0.06} ];
outer = inner + 2*roller + clearance/2;
pitch = outer - roller;
d = Pi / 180;
a = spot * d;
O = newp; Point(O) = {0, 0, 0, 2*h};

inner_way[] = {}; outer_way[] = {};  // raceways, from bottom to top
pi = newp; Point(pi) = {0, -inner, 0, fine};
po = newp; Point(po) = {0, -outer, 0, fine};
pi0 = pi; po0 = po;
For j In {0:6}
  t = 2*Pi*j/13;
  ex = Sin(t); ey = -Cos(t);     // along the radius
  fx = Cos(t); fy = Sin(t);      // along the pitch circle, upwards
  bi = a * roller / inner; bo = a * roller / outer;

  // the raceways: arcs up to the spot, with larger elements half-way, and the spot itself
  If (j > 0)
    m = t - Pi/13;
    p = newp; Point(p) = {inner*Sin(m), -inner*Cos(m), 0, h}; l = newl; Circle(l) = {pi, O, p}; inner_way[] += {l}; pi = p;
    p = newp; Point(p) = {outer*Sin(m), -outer*Cos(m), 0, h}; l = newl; Circle(l) = {po, O, p}; outer_way[] += {l}; po = p;
    p = newp; Point(p) = {inner*Sin(t - bi), -inner*Cos(t - bi), 0, fine}; l = newl; Circle(l) = {pi, O, p}; inner_way[] += {l}; pi = p;
    p = newp; Point(p) = {outer*Sin(t - bo), -outer*Cos(t - bo), 0, fine}; l = newl; Circle(l) = {po, O, p}; outer_way[] += {l}; po = p;
  EndIf
  p = newp; Point(p) = {inner*Sin(t + bi), -inner*Cos(t + bi), 0, fine}; l = newl; Circle(l) = {pi, O, p}; inner_way[] += {l}; pi = p;
  Physical Curve(Sprintf("inner_%g", j)) = {l};
  p = newp; Point(p) = {outer*Sin(t + bo), -outer*Cos(t + bo), 0, fine}; l = newl; Circle(l) = {po, O, p}; outer_way[] += {l}; po = p;
  Physical Curve(Sprintf("outer_%g", j)) = {l};

  // the roller
  c = newp; Point(c) = {pitch*ex, pitch*ey, 0};
  p = newp; l = newl;
  If (j == 0)
    Point(p) = {0, (pitch + roller)*ey, 0, fine};
    Point(p + 1) = {roller*Sin(a), (pitch + roller*Cos(a))*ey, 0, fine};
    Point(p + 2) = {roller, pitch*ey, 0, h/2};
    Point(p + 3) = {roller*Sin(a), (pitch - roller*Cos(a))*ey, 0, fine};
    Point(p + 4) = {0, (pitch - roller)*ey, 0, fine};
    For i In {0:3}
      Circle(l + i) = {p + i, c, p + i + 1};
    EndFor
    Line(l + 4) = {p + 4, p};
    w = newll; Curve Loop(w) = {l:l+4};
    Physical Curve("roller_0_outer") = {l};
    Physical Curve("roller_0_inner") = {l + 3};
    Physical Curve("roller_0_cut") = {l + 4};
  Else
    For i In {0:3}
      q = i*Pi/2;
      s = (i == 0 || i == 2) ? fine : h/3;
      Point(p + 2*i) = {pitch*ex + roller*(Cos(q - a)*ex + Sin(q - a)*fx), pitch*ey + roller*(Cos(q - a)*ey + Sin(q - a)*fy), 0, s};
      Point(p + 2*i + 1) = {pitch*ex + roller*(Cos(q + a)*ex + Sin(q + a)*fx), pitch*ey + roller*(Cos(q + a)*ey + Sin(q + a)*fy), 0, s};
    EndFor
    For i In {0:6}
      Circle(l + i) = {p + i, c, p + i + 1};
    EndFor
    Circle(l + 7) = {p + 7, c, p};
    w = newll; Curve Loop(w) = {l:l+7};
    Physical Curve(Sprintf("roller_%g_outer", j)) = {l};
    Physical Curve(Sprintf("roller_%g_behind", j)) = {l + 2};
    Physical Curve(Sprintf("roller_%g_inner", j)) = {l + 4};
    Physical Curve(Sprintf("roller_%g_before", j)) = {l + 6};
  EndIf
  s = news; Plane Surface(s) = {w};
  Physical Surface(Sprintf("roller_%g", j)) = {s};
EndFor

// the shaft, whose surface is the inner raceway, and the outer ring; the raceways continue to the top
p = newp; Point(p) = {0, inner, 0, h}; l = newl; Circle(l) = {pi, O, p}; inner_way[] += {l}; pi = p;
p = newp; Point(p) = {0, outer, 0, h}; l = newl; Circle(l) = {po, O, p}; outer_way[] += {l}; po = p;
l = newl; Line(l) = {pi, O}; Line(l + 1) = {O, pi0};
w = newll; Curve Loop(w) = {inner_way[], l, l + 1};
s = news; Plane Surface(s) = {w};
Physical Surface("shaft") = {s};
Physical Curve("shaft_cut") = {l, l + 1};
p = newp; Point(p) = {0, outside, 0, 1.5*h}; Point(p + 1) = {outside, 0, 0, 1.5*h}; Point(p + 2) = {0, -outside, 0, 1.5*h};
l = newl; Line(l) = {po, p}; Circle(l + 1) = {p, O, p + 1}; Circle(l + 2) = {p + 1, O, p + 2}; Line(l + 3) = {p + 2, po0};
w = newll; Curve Loop(w) = {outer_way[], l:l+3};
s = news; Plane Surface(s) = {w};
Physical Surface("ring") = {s};
Physical Curve("ring_cut") = {l, l + 3};
Physical Curve("housing") = {l + 1, l + 2};
