; check: exit 1
; error K-0120 at 4:1
; the program number of a Fanuc control would be the next message
G10 L2 P1 X0
O1000
M30
