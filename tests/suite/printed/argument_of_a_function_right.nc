; run: exit 0
; page 254758283 diagnosis 21459, right
; end X123
N10 P1 = SIN[1.23]
N20 P2 = STR_TO_INT["123"]
N30 G00 XP2
N40 M30
