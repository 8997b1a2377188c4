; check: exit 1
; error K-0019 at 3:3
X[LIFT]
M30
