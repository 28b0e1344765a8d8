import { useFrame } from '@react-three/fiber';
import { useEffect, useEffectEvent, useMemo, useRef, type RefObject } from 'react';
import type * as THREE from 'three';
import { Follower } from './Follower';
import type { Orbit } from './Surroundings';
import type { World } from './World';

const SAME = 1e-4;

interface Following {
  readonly isOn: boolean;
  /** A new object means a new view, in which the robot need not be in the middle. */
  readonly view: object;
  /** Called when the user turns or moves the camera; zooming keeps the robot where it is. */
  readonly onMoved: () => void;
  readonly requestFrame: () => void;
}

interface Stance {
  readonly target: THREE.Vector3;
  readonly direction: THREE.Vector3;
}

const stanceOf = ({ object, target }: Orbit): Stance => ({
  target: target.clone(),
  direction: object.position.clone().sub(target).normalize(),
});

const isSame = (a: Stance, b: Stance): boolean =>
  a.target.distanceTo(b.target) < SAME && a.direction.distanceTo(b.direction) < SAME;

/** Makes the camera follow the robot until the user moves the camera. */
export function useFollow(world: World, controls: RefObject<Orbit | null>, following: Following): void {
  const { isOn, view, requestFrame } = following;
  const onMoved = useEffectEvent(following.onMoved);
  const follower = useMemo(() => new Follower(), []);
  const shown = useRef<object | null>(null);
  const gesture = useRef<Stance | null>(null);

  useEffect(() => {
    const isNew = shown.current !== view;
    shown.current = view;
    const { robot } = world;
    if (!isOn || !robot) return follower.end();
    const target = controls.current?.target;
    follower.begin(robot.position, isNew || !target ? undefined : robot.position.clone().sub(target));
    requestFrame();
  }, [follower, world, controls, isOn, view, requestFrame]);

  useEffect(() => {
    const orbit = controls.current;
    if (!orbit) return;
    const onStart = () => {
      gesture.current = stanceOf(orbit);
    };
    const onEnd = () => {
      const before = gesture.current;
      gesture.current = null;
      if (before && !isSame(before, stanceOf(orbit))) onMoved();
    };
    orbit.addEventListener('start', onStart);
    orbit.addEventListener('end', onEnd);
    return () => {
      orbit.removeEventListener('start', onStart);
      orbit.removeEventListener('end', onEnd);
    };
  }, [controls, world]);

  useFrame(({ camera }, seconds) => {
    // The robot does not move the camera during a gesture of the user.
    if (!world.robot || !controls.current || gesture.current) return;
    const by = follower.step(world.robot.position, seconds);
    if (!by) return;
    camera.position.add(by);
    controls.current.target.add(by);
    requestFrame();
  });
}
