; run --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[97]=MNE_SNS: exit 0
; warning K-0109 at 6:1
; warning K-0109 at 9:1
G108
X10 Y10 F1000
G107
G108
X20 M96
M30
