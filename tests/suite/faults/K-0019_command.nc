; check: exit 1
; error K-0019 at 3:1
#CYL ON
M30
