; check: exit 1
; error 20509 at 23:4
; error 20509 at 24:4
; error 20509 at 25:4
; error 20509 at 26:4
; error 20509 at 27:4
; error 20509 at 28:4
; error 20509 at 29:4
; error 20509 at 30:4
; error 20509 at 31:4
; error 20509 at 32:5
; error 20509 at 33:5
; error 20509 at 34:5
; error 20509 at 35:5
; error 20509 at 36:5
; error 20509 at 37:5
; error 20509 at 38:5
; error 20509 at 39:5
; error 20509 at 40:5
; error 20509 at 41:5
; error 20509 at 42:5
; note K-0116 at 42:1
N1 #FOO
N2 #FOO
N3 #FOO
N4 #FOO
N5 #FOO
N6 #FOO
N7 #FOO
N8 #FOO
N9 #FOO
N10 #FOO
N11 #FOO
N12 #FOO
N13 #FOO
N14 #FOO
N15 #FOO
N16 #FOO
N17 #FOO
N18 #FOO
N19 #FOO
N20 #FOO
N21 #FOO
M30
