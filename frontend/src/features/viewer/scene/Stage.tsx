import { useFrame } from '@react-three/fiber';
import { useCallback, useEffect, useMemo, useRef } from 'react';
import type { Scene } from '@/generated/messages';
import { shownFrames } from '@/store/session/frames';
import { forEachPose, type Pose } from '@/store/session/poses';
import { useShownPaths } from '@/store/session/trace/shownPaths';
import { shownTrail } from '@/store/session/trace/shownTrail';
import type { StageHost } from './host';
import { FirstPicture } from './FirstPicture';
import { FramesView, FrustumView } from './HelperViews';
import { LidarView } from './LidarView';
import { MeasureLine } from './MeasureLine';
import { Surroundings, useSight, type Orbit } from './Surroundings';
import { TextureCache } from './TextureCache';
import { surroundingsOf } from './framing';
import { PathsView } from '../paths/PathsView';
import { TrailView } from './TrailView';
import { useFollow } from './useFollow';
import type { ViewOptions } from '../viewOptions';
import { useSlowness } from '../useSlowness';
import { useTools } from '../useTools';
import { useThrottledInvalidate } from '../useThrottledInvalidate';
import { isSoftwareWebGl } from '../webgl';
import { World } from './World';

/** The largest diagonal of a world that the first view shows as a whole, in m. */
const LARGEST_M = 24;

interface StageProps {
  readonly scene: Scene;
  readonly options: ViewOptions;
  readonly isDark: boolean;
  /** Whether a rate of pictures that is too low is reported. */
  readonly isJudged: boolean;
  readonly host: StageHost;
  /** Called when the user turns or moves the camera. */
  readonly onMoved: () => void;
  /** Called with the rate of pictures in Hz when it has been too low for too long. */
  readonly onSlow: (hz: number) => void;
  /** Called when the first picture is drawn. */
  readonly onDrawn: () => void;
}

/** The content of the 3D view: the world, its light, and optional helpers. */
export function Stage(props: StageProps) {
  const { scene, options, isDark, isJudged, host, onMoved, onSlow, onDrawn } = props;
  const isSimple = isSoftwareWebGl();
  const invalidate = useThrottledInvalidate();
  const slowness = useSlowness(isJudged, onSlow);
  const requestFrame = useCallback(() => {
    slowness.request();
    invalidate();
  }, [slowness, invalidate]);
  const textures = useMemo(
    () => new TextureCache(scene.textures ?? {}, requestFrame, isSimple ? 1 : 8),
    [scene, isSimple, requestFrame],
  );
  const world = useMemo(() => new World(scene, isSimple, textures), [scene, isSimple, textures]);
  const lidar = useMemo(() => new LidarView(), []);
  const trailView = useMemo(() => new TrailView(shownTrail), []);
  const pathsView = useMemo(() => new PathsView(), []);
  const paths = useShownPaths((state) => state.paths);
  const framesView = useMemo(() => new FramesView(scene, world), [scene, world]);
  const frustum = useMemo(() => new FrustumView(scene, world), [scene, world]);
  const controls = useRef<Orbit | null>(null);

  useEffect(() => () => world.dispose(), [world]);
  useEffect(() => () => lidar.dispose(), [lidar]);
  useEffect(() => () => trailView.dispose(), [trailView]);
  useEffect(() => () => pathsView.dispose(), [pathsView]);
  useEffect(() => () => framesView.dispose(), [framesView]);
  useEffect(() => () => frustum.dispose(), [frustum]);
  useEffect(() => {
    framesView.show(options.frames);
    frustum.show(options.frustum);
    requestFrame();
  }, [framesView, frustum, options.frames, options.frustum, requestFrame]);

  useEffect(() => {
    pathsView.show(paths, isDark, shownTrail.until);
    requestFrame();
  }, [pathsView, paths, isDark, requestFrame]);

  useEffect(() => {
    const stopPoses = shownFrames.listen('poses', (frame) => {
      const changed: [number, Pose][] = [];
      forEachPose(frame, (id, pose) => changed.push([id, pose]));
      world.receive(changed, performance.now());
      requestFrame();
    });
    const stopScans = shownFrames.listen('scan', (scan) => {
      lidar.show(scan);
      requestFrame();
    });
    const stopTrail = shownTrail.subscribe(() => {
      pathsView.move(shownTrail.until);
      requestFrame();
    });
    return () => {
      stopTrail();
      stopPoses();
      stopScans();
    };
  }, [world, lidar, pathsView, requestFrame]);

  useFrame(() => {
    slowness.draw();
    const isMoving = world.advance(performance.now());
    if (options.trail) trailView.update();
    if (isMoving) requestFrame();
  });

  // Another world gets a new view; the same world keeps its view after a reset.
  const view = useMemo(
    () => ({ kind: options.viewpoint.kind, of: scene.name }),
    // A new request object moves the camera, even to the place of the previous request.

    [options.viewpoint, scene.name],
  );
  useSight(controls, view, () => ({
    bounds:
      view.kind === 'default' && world.robot
        ? surroundingsOf(world.bounds, world.robot.position, LARGEST_M)
        : world.bounds,
    kind: view.kind,
    least: 4,
    most: LARGEST_M,
  }));
  useFollow(world, controls, { isOn: options.follow, view, onMoved, requestFrame });
  useTools(world, controls, host, options.trail);

  return (
    <Surroundings
      controls={controls}
      element={host.element}
      isDark={isDark}
      lights={scene.lights}
      bounds={world.bounds}
      ground={{ color: scene.ground_color, picture: scene.ground_texture }}
      textures={textures}
      hasGrid={options.grid}
      reach={[0.4, 60]}
    >
      <primitive object={world.group} />
      {options.rays ? <primitive object={lidar.group} /> : null}
      {options.trail ? <primitive object={trailView.line} /> : null}
      <primitive object={pathsView.group} />
      {options.frames ? <primitive object={framesView.origin} /> : null}
      <MeasureLine />
      <FirstPicture onDrawn={onDrawn} />
    </Surroundings>
  );
}
