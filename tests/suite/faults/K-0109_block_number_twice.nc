; run: exit 0
; note K-0081 at 6:1
; note K-0081 at 7:1
; note K-0081 at 6:1
; warning K-0109 at 8:17
N10 #MSG ["a"]
N10 #MSG ["b"]
N20 L SEQUENCE [N10 N10]
M30
