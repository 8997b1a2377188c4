; check: exit 1
; error 21559 at 3:3
Z[LIFT_END]
M30
