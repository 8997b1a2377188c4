; check: exit 1
; error 20644 at 5:1
; error 20644 at 6:4
"FLUSH"="#FLUSH WAIT"
"FLUSH" X10 F1000
X5 "FLUSH"
M30
