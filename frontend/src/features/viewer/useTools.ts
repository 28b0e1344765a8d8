import { useThree } from '@react-three/fiber';
import { useEffect } from 'react';
import type { OrbitControls } from '@react-three/drei/core/OrbitControls';
import type { ComponentRef } from 'react';
import { DraggedBody, carriable } from './scene/DraggedBody';
import { pointedAt, pointedAtHeight, trailMomentAt } from './pointing';
import { shownTrail } from '@/store/session/trace/shownTrail';
import { useMeasuring } from './measuring';
import type { StageHost } from './scene/host';
import type { World } from './scene/World';

type Controls = { readonly current: ComponentRef<typeof OrbitControls> | null };

const CLICK_PX = 4;
const RIGHT_BUTTON = 2;
const TURN_RAD = Math.PI / 12;

/**
 * Adds the tools of the pointer: dragging bodies while time is paused, measuring, and going to the moment of a
 * place on the trail. The camera controls turn the view.
 */
export function useTools(world: World, controls: Controls, host: StageHost, hasTrail = false): void {
  const camera = useThree((state) => state.camera);
  const own = useThree((state) => state.gl.domElement);
  const canvas = host.element ?? own;
  const invalidate = useThree((state) => state.invalidate);

  useEffect(() => {
    let dragged: DraggedBody | null = null;
    let from = { x: 0, y: 0, height: 0 };
    let pressed = { x: 0, y: 0 };

    const freeView = (isFree: boolean) => {
      if (controls.current) controls.current.enabled = isFree;
    };
    const end = (isKept: boolean) => {
      if (!dragged) return;
      const done = dragged;
      dragged = null;
      freeView(true);
      canvas.style.cursor = '';
      const pose = done.pose();
      const isMoved = isKept && done.hasMoved;
      done.release(isMoved);
      invalidate();
      if (!isMoved) return;
      host.moveBody(done.body, pose, done.origin).catch(() => {
        world.put(done.body);
        invalidate();
      });
    };
    const onDown = (event: PointerEvent) => {
      pressed = { x: event.clientX, y: event.clientY };
      if (event.button !== 0 || useMeasuring.getState().isOn || !host.canMove()) return;
      const hit = pointedAt(event, canvas, camera, world);
      const body = hit && carriable(world, hit.objectId);
      if (!hit || !body) return;
      dragged = new DraggedBody(world, body);
      from = { x: hit.point.x, y: hit.point.y, height: hit.point.z };
      freeView(false);
      canvas.setPointerCapture(event.pointerId);
      canvas.style.cursor = 'grabbing';
      event.stopImmediatePropagation();
      invalidate();
    };
    const onMove = (event: PointerEvent) => {
      if (!dragged) return showCursor(event);
      // Pressing the right button during a drag with the left one cancels the drag.
      if (event.buttons & RIGHT_BUTTON) return end(false);
      const at = pointedAtHeight(event, canvas, camera, from.height);
      if (at) dragged.moveBy(at.x - from.x, at.y - from.y);
      invalidate();
    };
    const showCursor = (event: PointerEvent) => {
      if (event.buttons !== 0) return;
      const isMeasuring = useMeasuring.getState().isOn;
      const hit = !isMeasuring && host.canMove() ? pointedAt(event, canvas, camera, world) : null;
      const isCarriable = hit !== null && carriable(world, hit.objectId) !== null;
      const cursor = isCarriable ? 'grab' : momentAt(event) === null ? '' : 'pointer';
      canvas.style.cursor = isMeasuring ? 'crosshair' : cursor;
    };
    const momentAt = (event: PointerEvent): number | null =>
      hasTrail ? trailMomentAt(event, canvas, camera, world, shownTrail) : null;
    const onUp = (event: PointerEvent) => {
      if (dragged) return end(true);
      const isClick = Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < CLICK_PX;
      if (!isClick || event.button !== 0) return;
      if (!useMeasuring.getState().isOn) {
        const t = momentAt(event);
        if (t !== null) host.goTo(t);
        return;
      }
      const hit = pointedAt(event, canvas, camera, world);
      if (hit) host.addMeasured([hit.point.x, hit.point.y, hit.point.z]);
      invalidate();
    };
    const onKey = (event: Event) => {
      const { key } = event as KeyboardEvent;
      if (!dragged) return;
      if (key === 'Escape') end(false);
      else if (key === 'q' || key === 'e') dragged.turnBy(key === 'q' ? TURN_RAD : -TURN_RAD);
      else return;
      event.preventDefault();
      invalidate();
    };
    const onCancel = () => end(false);

    canvas.addEventListener('pointerdown', onDown, { capture: true });
    canvas.addEventListener('pointermove', onMove);
    canvas.addEventListener('pointerup', onUp);
    canvas.addEventListener('pointercancel', onCancel);
    host.keys.addEventListener('keydown', onKey);
    return () => {
      end(false);
      canvas.removeEventListener('pointerdown', onDown, { capture: true });
      canvas.removeEventListener('pointermove', onMove);
      canvas.removeEventListener('pointerup', onUp);
      canvas.removeEventListener('pointercancel', onCancel);
      host.keys.removeEventListener('keydown', onKey);
    };
  }, [world, controls, camera, canvas, host, invalidate, hasTrail]);
}
