; run: exit 0
; page 207120267 definitions by logical numbers (#AX LINK NBR)
; end X0 Y0
N10 #AX LINK NBR [2, 3 = 2]
N20 #AX LINK NBR [3,[3 = 2,G]]
N30 G00 X0 Y0
N40 M30
