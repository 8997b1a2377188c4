; check: exit 1
; error 21241 at 3:11
P1 = ASIN[2]
M30
