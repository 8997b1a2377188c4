; check: exit 1
; error 20734 at 4:7
"A" = "X1 \"A\""
F1000 "A"
M30
