; check: exit 1
; warning K-0101 at 5:1
; error K-0120 at 7:1
; subroutine call of other dialects
M98
X1 F100
M98 P1000
M30
