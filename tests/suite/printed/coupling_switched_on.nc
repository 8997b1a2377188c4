; check: exit 1
; page 207133579 axis couplings switched on (#ENABLE AX LINK)
; error K-0019 at 6:5
; error K-0019 at 9:5
N10 #SET AX LINK [1, Y = X]
N20 #ENABLE AX LINK [1]
N30 G00 X10
N40 #DISABLE AX LINK [1]
N50 #AX LINK ON [1]
N60 #AX LINK OFF ALL
N70 M30
