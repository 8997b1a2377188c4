; check: exit 1
; error 21220 at 3:1
#SLOPE []
M30
