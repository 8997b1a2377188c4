; run --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[97]=MNE_SNS --input x25.csv: exit 1
; error 50655 at 4:1
N10 G108
N20 M97 G01 X50 F3000
N30 M30
