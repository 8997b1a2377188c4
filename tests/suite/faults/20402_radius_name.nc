; check: exit 1
; error 20402 at 3:1
RA=5
M30
