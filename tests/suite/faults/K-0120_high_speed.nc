; check: exit 1
; error K-0120 at 3:1
G05 P10000
G43 H1
M30
