; check: exit 1
; error 20194 at 5:5
; warning K-0101 at 5:1
; subroutine call of other dialects
M98 P1000
M98 P1000
X1 F100
M30
