; check: exit 1
; error K-0120 at 4:5
; the rest is not checked
G91 G28 Z0
G43 H1
M30
