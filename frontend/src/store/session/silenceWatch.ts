import { t } from '@/i18n';
import type { ControlSocket } from './control';
import { Heartbeat, HEARTBEAT_MS } from './heartbeat';
import { note, useSessionStore } from './store';

/** Pings the session at a fixed rate, and shows the time since its last message. */
export class SilenceWatch {
  private heartbeat: Heartbeat | null = null;
  private timer: ReturnType<typeof setInterval> | undefined;
  private isPinging = false;

  start(socket: ControlSocket): void {
    this.stop();
    this.heartbeat = new Heartbeat(performance.now());
    this.timer = setInterval(() => this.beat(socket), HEARTBEAT_MS);
  }

  stop(): void {
    clearInterval(this.timer);
    this.heartbeat = null;
    this.isPinging = false;
  }

  heard(): void {
    this.heartbeat?.heard(performance.now());
  }

  private beat(socket: ControlSocket): void {
    const asked = this.heartbeat;
    if (!asked) return;
    const now = performance.now();
    // While the page is sending, for example a large program, it cannot expect an answer.
    if (!this.isPinging || socket.isSending) asked.heard(now);
    showSilence(asked.beat(now));
    if (this.isPinging) return;
    this.isPinging = true;
    const answered = () => {
      if (asked === this.heartbeat) this.isPinging = false;
    };
    // A refused ping also shows that the session answers.
    socket.send('ping', {}).then(answered, answered);
  }
}

function showSilence(silentS: number): void {
  const before = useSessionStore.getState().silentS;
  if (silentS === before) return;
  useSessionStore.setState({ silentS });
  if (before === 0) note(t('run:silence.began', { seconds: silentS }));
  else if (silentS === 0) note(t('run:silence.ended', { seconds: before }));
}
