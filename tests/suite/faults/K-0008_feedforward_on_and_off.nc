; check: exit 1
; error K-0008 at 3:6
G135 G137
M30
