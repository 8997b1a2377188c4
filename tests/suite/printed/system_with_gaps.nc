; run: exit 0
; page 208480907 coordinate systems, components left out
; passes X7.0710678 Y7.0710678 Z10
#CS ON [,,10,,,45]
N10 G01 X10 Y0 Z0 F1000
N20 M30
