; run: exit 0
; page 206109707 helix by its target point
; passes X10 Y0 Z10
; end X-10 Y0 Z20
N10 G17 G90 X-10 Y0 Z0 F5000 G161
N20 G03 I0 J0 Z20
M30
