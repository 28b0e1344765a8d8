/** The settings of a 3D view's root, the same on the page and in a worker. */
export const rootOptions = (isVisible: boolean, isSimple: boolean) => ({
  frameloop: isVisible ? ('demand' as const) : ('never' as const),
  shadows: isSimple ? false : ('percentage' as const),
  gl: { antialias: !isSimple, powerPreference: 'high-performance' as const },
  camera: {
    fov: 45,
    near: 0.05,
    far: 200,
    up: [0, 0, 1] as [number, number, number],
    position: [-4, -4, 4] as [number, number, number],
  },
});

/**
 * The range of picture pixels for each CSS pixel, as [lowest, highest]. It is lower if the processor draws
 * the picture.
 */
export const dprRange = (isSimple: boolean): [number, number] => (isSimple ? [0.8, 0.8] : [1, 2]);
