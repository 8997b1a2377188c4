; check: exit 1
; error 20207 at 3:11
X10 F1000 #FLUSH
M30
