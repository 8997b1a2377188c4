; check --set channel.m_synch[50]=MOS --set channel.m_prozess_zeit[50]=1000: exit 0
; warning 20760 at --set 1:1
M30
