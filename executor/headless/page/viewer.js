'use strict';
// The viewer of `bt-studio run --serve-viewer`: pictures and figures come, where one looks from goes back.

const START = { yaw: -2.3, pitch: 0.6, distance: 8, target: [0, 0, 0.2] };
const SEND_EVERY_MS = 60;
const KEY_RAD = 0.1;
const KEY_ZOOM = 1.15;
const PITCH_RAD = [0.05, 1.5];
const DISTANCE_M = [0.8, 60];
const PING_EVERY_MS = 1000;
const SHOWN_AFTER_MS = 3000;
const PING = 'ping';

const byId = (id) => document.getElementById(id);
const world = byId('world');
const picture = byId('picture');
const orbit = { ...START };
let sending;

const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
const socket = new WebSocket(`${scheme}://${location.host}/socket${location.search}`);
socket.binaryType = 'blob';
socket.onopen = () => look();
socket.onmessage = ({ data }) => {
  silentMs = 0;
  if (typeof data !== 'string') showPicture(data);
  else if (data !== PING) showFigures(JSON.parse(data));
};
socket.onclose = () => {
  clearInterval(asking);
  showSilence();
  if (byId('state').dataset.over) return;
  byId('state').textContent = 'The run is over.';
  byId('running').textContent = '';
};

// Whether the run still answers. A page that slept meanwhile has waited for nothing.
let silentMs = 0;
let askedAt = performance.now();
const asking = setInterval(() => {
  if (socket.readyState !== WebSocket.OPEN) return;
  silentMs += Math.min(performance.now() - askedAt, PING_EVERY_MS);
  askedAt = performance.now();
  socket.send(PING);
  showSilence(silentMs);
}, PING_EVERY_MS);

function showSilence(ms = 0) {
  const note = byId('silence');
  note.hidden = ms < SHOWN_AFTER_MS;
  byId('silent-s').textContent = String(Math.round(ms / 1000));
}

function showPicture(blob) {
  const old = picture.src;
  picture.src = URL.createObjectURL(blob);
  if (old) URL.revokeObjectURL(old);
}

function showFigures({ project, status, is_over: isOver, figures, running }) {
  document.title = `${status} · ${project}`;
  byId('project').textContent = project;
  const state = byId('state');
  state.textContent = isOver ? `${status}, the run is over` : status;
  state.dataset.status = status;
  if (isOver) state.dataset.over = 'true';
  byId('figures').replaceChildren(...Object.entries(figures).map(figure));
  byId('running').textContent = running.join(' › ');
}

function figure([name, value]) {
  const row = document.createElement('div');
  const term = document.createElement('dt');
  const description = document.createElement('dd');
  term.textContent = name;
  description.textContent = value;
  row.append(term, description);
  return row;
}

const clamp = (value, [low, high]) => Math.min(high, Math.max(low, value));

function eye() {
  const flat = orbit.distance * Math.cos(orbit.pitch);
  const [x, y, z] = orbit.target;
  return [x + flat * Math.cos(orbit.yaw), y + flat * Math.sin(orbit.yaw), z + orbit.distance * Math.sin(orbit.pitch)];
}

function turn(yaw, pitch) {
  orbit.yaw += yaw;
  orbit.pitch = clamp(orbit.pitch + pitch, PITCH_RAD);
  look();
}

function zoom(factor) {
  orbit.distance = clamp(orbit.distance * factor, DISTANCE_M);
  look();
}

function move(right, ahead) {
  const scale = orbit.distance / 600;
  const [sin, cos] = [Math.sin(orbit.yaw), Math.cos(orbit.yaw)];
  orbit.target[0] += scale * (sin * right - cos * ahead);
  orbit.target[1] += scale * (-cos * right - sin * ahead);
  look();
}

function look() {
  sending ??= setTimeout(() => {
    sending = undefined;
    if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ eye: eye(), target: orbit.target }));
  }, SEND_EVERY_MS);
}

world.addEventListener('pointerdown', (event) => world.setPointerCapture(event.pointerId));
world.addEventListener('contextmenu', (event) => event.preventDefault());
world.addEventListener('pointermove', (event) => {
  if (event.buttons === 1 && !event.shiftKey) turn(-event.movementX * 0.006, event.movementY * 0.006);
  else if (event.buttons !== 0) move(event.movementX, event.movementY);
});
world.addEventListener(
  'wheel',
  (event) => {
    event.preventDefault();
    zoom(Math.exp(event.deltaY * 0.001));
  },
  { passive: false },
);
world.addEventListener('keydown', (event) => {
  const moves = {
    ArrowLeft: () => turn(-KEY_RAD, 0),
    ArrowRight: () => turn(KEY_RAD, 0),
    ArrowUp: () => turn(0, KEY_RAD),
    ArrowDown: () => turn(0, -KEY_RAD),
    '+': () => zoom(1 / KEY_ZOOM),
    '-': () => zoom(KEY_ZOOM),
  };
  if (!moves[event.key]) return;
  event.preventDefault();
  moves[event.key]();
});
