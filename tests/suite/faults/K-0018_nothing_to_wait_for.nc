; check: exit 0
; warning K-0018 at 3:1
#WAIT SYN
M30
