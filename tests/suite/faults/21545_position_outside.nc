; check: exit 1
; error 21545 at 9:44
; error 21545 at 10:35
; error 21545 at 11:35
; error 21545 at 12:44
; error 21545 at 13:44
; error 21545 at 14:44
; warning K-0110 at 15:5
N10 V.E.string = DELETE["Hello world!", 7, 100]
N10 V.E.string = MID["Hello!", 1, 7]
N10 V.E.string = MID["Hello!", 1, 0]
N10 V.E.string = INSERT["Hello!", "world", 7]
N10 V.E.string = REPLACE["Hello!", "J", 1, 0]
N10 V.E.string = DELETE["Hello world!", 7, -1]
N20 V.E.string = DELETE["Hello world!", 7, 5] + MID["Hello!", 1, 6] + INSERT["ello!", "H", 0] + INSERT["Hello", "!", 5]
M30
