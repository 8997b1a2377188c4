; check: exit 1
; error K-0019 at 4:3
; error 21558 at 5:3
Z[LIFT_START POS_LIMIT=5]
Z[LIFT_START POS_LIMIT=5]
M30
