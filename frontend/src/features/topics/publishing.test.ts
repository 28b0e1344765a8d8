import { expect, it } from 'vitest';
import { closePublish, openPublish, usePublishing } from './publishing';

it('stores the initial values of the dialogue, until it is closed', () => {
  expect(usePublishing.getState().opened).toBeNull();
  openPublish('/odom', 'nav_msgs/msg/Odometry');
  expect(usePublishing.getState().opened).toEqual({ topic: '/odom', type: 'nav_msgs/msg/Odometry' });
  closePublish();
  expect(usePublishing.getState().opened).toBeNull();
});
