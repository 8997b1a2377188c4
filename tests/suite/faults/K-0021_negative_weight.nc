; check: exit 1
; error K-0021 at 3:6
G136 X-1
M30
