; check: exit 1
; error K-0019 at 4:1
; error 20123 at 4:6
G100 G101
M30
