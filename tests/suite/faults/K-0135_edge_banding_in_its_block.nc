; check --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[97]=MNE_SNS: exit 1
; error K-0135 at 4:14
N10 G01 X1 F100
N20 G108 X50 M97
N30 M30
