; run: exit 0
; page 206884875 indirect parameters, two of one value
; end X50 Y50
N110 P1 = 20  P2 = 40
N120 PP1 = 50
N130 PP2 = PP1
G01 F6000 XP20 YP40
M30
