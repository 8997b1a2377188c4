; run: exit 0
; page 206023179 length and characters of texts
; end X25 Y72 Z119
P1 = LEN["Hello world! How are you?"]
P2 = ORD["Hello world!", 1]
P3 = ORD["Hello world!", 7]
N10 G00 XP1 YP2 ZP3
N20 M30
