import * as THREE from 'three';

/** Global settings of three.js for every 3D view; imported for its side effect. */
THREE.Object3D.DEFAULT_UP.set(0, 0, 1);

// The renderer for React still uses a clock that three.js has since renamed; users can do nothing about it.
THREE.setConsoleFunction((type, message, ...details) => {
  if (message.startsWith('THREE.Clock:')) return;
  // eslint-disable-next-line no-console
  console[type](message, ...details);
});
