export interface ViewOptions {
  rays: boolean;
  trail: boolean;
  grid: boolean;
  /** Coordinate frames of world, links and sensors. */
  frames: boolean;
  /** The field of view of the robots' cameras, as pyramids. */
  frustum: boolean;
  /** Whether the camera follows the robot: until the user moves it. */
  follow: boolean;
  /** Whether the robot's camera is shown in a corner; null: if the program uses pictures. */
  camera: boolean | null;
  /** A new object moves the camera, even to the place of the previous request. */
  viewpoint: { kind: 'default' | 'top' };
}

type Kept = Pick<ViewOptions, 'rays' | 'trail' | 'grid' | 'frames' | 'frustum' | 'camera'>;

const KEY = 'bts.viewer';
const DEFAULTS: Kept = {
  rays: true,
  trail: true,
  grid: true,
  frames: false,
  frustum: true,
  camera: null,
};

export function loadViewOptions(): ViewOptions {
  let kept: Partial<Kept> = {};
  try {
    kept = JSON.parse(localStorage.getItem(KEY) ?? '{}') as Partial<Kept>;
  } catch {
    // The stored options are unreadable: the defaults apply.
  }
  return { ...DEFAULTS, ...kept, follow: true, viewpoint: { kind: 'default' } };
}

export function keepViewOptions({ viewpoint: _, follow: __, ...kept }: ViewOptions): void {
  localStorage.setItem(KEY, JSON.stringify(kept satisfies Kept));
}
