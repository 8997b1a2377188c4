; check: exit 0
; warning K-0100 at 3:13
N10 #DELETE V.S.LAST
N20 M30
