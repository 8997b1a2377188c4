; run: exit 0
; page 15556927627 suppressed offsets, older page
; passes X10 Y20
; end X0 Y0
N05 G00
N10 G92 X10 Y20
N20 X0 Y0
N30 #SUPPRESS OFFSETS X0 Y0
M30
