import { notifications } from '@mantine/notifications';
import { lookAt } from '@/store/moment/looking';
import { send } from '@/store/session/connection';
import { canMove, useMoves } from './lastMove';
import { addMeasured } from './measuring';
import type { StageHost } from './scene/host';

/** The host of a stage that the page itself draws. */
export const pageHost: StageHost = {
  element: null,
  keys: window,
  canMove,
  addMeasured,
  goTo: (t) => lookAt(t),
  async moveBody(body, pose, from) {
    try {
      await send('move_body', { id: body, pose });
    } catch (error) {
      notifications.show({ color: 'red', message: (error as Error).message });
      throw error;
    }
    useMoves.setState({ last: { body, from } });
  },
};
