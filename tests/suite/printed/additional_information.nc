; run: exit 0
; page 15556955787 information at the end of a block (#ADD)
; end X10 Y20 Z30
; note K-0081 at 11:1
; note K-0081 at 12:1
; note K-0081 at 13:1
; note K-0081 at 14:1
%add_block_info
N05 P1=20
N10 G00 X0 Y0 Z0
N15 T1 #ADD["Tool T=%d active", V.G.T_AKT]
N20 G01 F2000 X10 #ADD["Move to X-position"] (Comment)
N30 YP1 #ADD["Y-position=%d", P1]
N40 Z30 #ADD["Z-position"]
N999 M30
