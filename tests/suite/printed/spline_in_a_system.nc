; check: exit 1
; page 264458891 diagnosis 120199, spline in a turned system, right
; error K-0019 at 9:1
; error K-0019 at 10:1
; error K-0019 at 11:1
; error K-0019 at 12:1
; error K-0019 at 13:1
N05 #CS ON[0,0,0,0,0,30]
N10 G151 X3 Y25 F6000
N20      X15 Y15
N30      X23 Y12
N40      X25 Y25
N50      X30 Y35
N60 G150 X50 Y37.5
N70 #CS OFF
N80 M30
