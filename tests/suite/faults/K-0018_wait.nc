; check: exit 1
; error K-0018 at 3:11
#WAIT FOR 1 == 2
M30
