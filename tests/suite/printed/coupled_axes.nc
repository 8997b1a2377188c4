; check: exit 1
; page 285670667 coupled axes (#AX LINK)
; error K-0019 at 5:5
; error K-0019 at 6:5
N10 #SET AX LINK [1, [Y = X, G, 0.01, 0.25]]
N20 #AX LINK [3, [Y = X]]
N30 M30
