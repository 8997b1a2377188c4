; check: exit 0
; warning K-0110 at 3:1
V.E.TEMPERATURE=1
M30
