import * as THREE from 'three';

/** Sets three.js up for all 3D views; this module is imported for its side effect. */
THREE.Object3D.DEFAULT_UP.set(0, 0, 1);

// React's renderer uses a clock class that three.js has renamed; the warning does not help users.
THREE.setConsoleFunction((type, message, ...details) => {
  if (message.startsWith('THREE.Clock:')) return;
  // eslint-disable-next-line no-console
  console[type](message, ...details);
});
