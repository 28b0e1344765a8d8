export interface ViewOptions {
  rays: boolean;
  trail: boolean;
  grid: boolean;
  /** Coordinate frames of world, links and sensors. */
  frames: boolean;
  /** What the robots' cameras see, as pyramids. */
  frustum: boolean;
  follow: boolean;
  /** Whether the robot's camera is shown in a corner; null leaves it to whether the program uses pictures. */
  camera: boolean | null;
  /** A new object moves the camera, also to where it already was asked to go. */
  viewpoint: { kind: 'default' | 'top' };
}

type Kept = Pick<ViewOptions, 'rays' | 'trail' | 'grid' | 'frames' | 'frustum' | 'follow' | 'camera'>;

const KEY = 'bts.viewer';
const DEFAULTS: Kept = {
  rays: true,
  trail: true,
  grid: true,
  frames: false,
  frustum: true,
  follow: false,
  camera: null,
};

export function loadViewOptions(): ViewOptions {
  let kept: Partial<Kept> = {};
  try {
    kept = JSON.parse(localStorage.getItem(KEY) ?? '{}') as Partial<Kept>;
  } catch {
    // Unreadable: the defaults.
  }
  return { ...DEFAULTS, ...kept, viewpoint: { kind: 'default' } };
}

export function keepViewOptions({ viewpoint: _, ...kept }: ViewOptions): void {
  localStorage.setItem(KEY, JSON.stringify(kept satisfies Kept));
}
