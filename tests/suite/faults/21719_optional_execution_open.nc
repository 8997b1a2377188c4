; check: exit 1
; warning K-0100 at 4:1
; error 21719 at 4:1
#OPTIONAL EXECUTION ON
X1 F1000
M30
