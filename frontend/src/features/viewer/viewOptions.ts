export interface ViewOptions {
  rays: boolean;
  trail: boolean;
  grid: boolean;
  /** Whether the coordinate frames of world, links and sensors are shown. */
  frames: boolean;
  /** Whether the fields of view of the robots' cameras are shown, as pyramids. */
  frustum: boolean;
  /** Whether the camera follows the robot, until the user moves the camera. */
  follow: boolean;
  /** Whether the robot's camera is shown in a corner; null: only if the program uses pictures. */
  camera: boolean | null;
  /** A request to move the camera; a new object moves it even to the same place. */
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
    // The stored options are unreadable, so the defaults apply.
  }
  return { ...DEFAULTS, ...kept, follow: true, viewpoint: { kind: 'default' } };
}

export function keepViewOptions({ viewpoint: _, follow: __, ...kept }: ViewOptions): void {
  localStorage.setItem(KEY, JSON.stringify(kept satisfies Kept));
}
