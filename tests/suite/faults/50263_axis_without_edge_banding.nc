; check --set channel.m_synch[97]=MNE_SNS --set Y.kenngr.kasto_achse=1: exit 1
; error 50263 at 4:13
N10 G108
N20 M97 G01 X10 Y10 F100
N30 M30
