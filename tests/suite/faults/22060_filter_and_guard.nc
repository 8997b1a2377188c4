; check: exit 1
; warning K-0109 at 4:1
; error 22060 at 5:1
#FILTER OFF
#VIB GUARD OFF
M30
