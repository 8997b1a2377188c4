; check: exit 1
; error 20011 at 3:1
X94967596 F1000
M30
