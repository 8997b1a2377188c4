; check --set channel.m_synch[97]=MNE_SNS --set channel.m_synch[96]=0x20: exit 1
; error 20156 at 3:22
N10 G01 X10 F100 M97 M96
N20 M30
