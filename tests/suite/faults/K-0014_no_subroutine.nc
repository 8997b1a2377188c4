; check: exit 1
; error K-0014 at 3:4
LL NOTHING
M30
