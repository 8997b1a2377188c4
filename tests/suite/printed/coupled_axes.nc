; run: exit 0
; page 285670667 definitions of coupled axes (#SET AX LINK)
; end X0 Y0
N10 #SET AX LINK [1, [Y = X, G, 0.01, 0.25]]
N15 #SET AX LINK [2, [Y = X, G]]
N20 #AX LINK [3, [Y = X]]
N30 G00 X0 Y0
N40 M30
