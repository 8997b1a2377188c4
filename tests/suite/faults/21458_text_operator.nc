; check: exit 1
; error 21458 at 3:9
V.P.T = "A" - "B"
M30
