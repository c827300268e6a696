% GNU Octave: ode45 with events, one call a flight. Octave finds events by
% linear interpolation, so impact times stay wrong at any tolerance.
%   octave-cli ode45_cases.m FOLDER
%   octave-cli ode45_cases.m serve default|best    flights for benchmark.py
1;

function s = read_scene(path)
  file = fopen(path);
  text = strsplit(fread(file, Inf, "*char")', "\n");
  fclose(file);
  value = @(k) strsplit(text{k}, " "){2};
  s.name = value(1);
  s.alpha = str2double(value(2));
  s.p = str2double(value(3));
  s.eta = str2double(value(4));
  s.dt = str2double(value(5));
  n = str2double(value(7));
  s.f = cellfun(@str2double, text(8:7 + n)) * str2double(value(6));
  s.slope = diff(s.f) / s.dt;
  s.end = (n - 1) * s.dt;
  s.threshold = tan(s.alpha);
  s.cosine = cos(s.alpha);
end

function [t, sign_f] = exceedance(s, t)
  sign_f = 0;
  first = floor(t / s.dt) + 1;
  for k = first:numel(s.slope)
    start = (k - 1) * s.dt;
    if (k == first)
      start = t;
    end
    now = s.f(k) + s.slope(k) * (start - (k - 1) * s.dt);
    if (abs(now) > s.threshold)
      t = start;
      sign_f = sign(now);
      return
    end
    if (abs(s.f(k + 1)) > s.threshold)
      sign_f = sign(s.f(k + 1));
      t = start + (sign_f * s.threshold - now) / s.slope(k);
      return
    end
  end
end

function rest = chatter(s, t, side, speed)
  rest = [];
  k = floor(t / s.dt) + 1;
  if (k > numel(s.slope))
    return
  end
  restoring = @(f) (s.threshold + f) * s.cosine;
  f = side * (s.f(k) + s.slope(k) * (t - (k - 1) * s.dt));
  w = speed / s.p;
  left = (k * s.dt - t) * s.p;
  if (!(s.threshold - abs(f) > 0))
    return
  end
  guess = 2 * w / (restoring(-abs(f)) * (1 - s.eta));
  if (!(guess < left))
    return
  end
  window = min(2 * guess, left);
  drift = abs(s.slope(k) / s.p) * window;
  least = restoring(-(abs(f) + drift));
  if (!(least > 0))
    return
  end
  push = (1 + s.threshold) * 2 * w * w / least;
  least -= push;
  if (!(least > 0))
    return
  end
  ratio = @(x) (restoring(x + drift) + push) / (restoring(x - drift) - push);
  worst = max(ratio(f), ratio(-f));
  decay = s.eta * sqrt(worst);
  if (!(decay < 1))
    return
  end
  if (!(2 * w * sqrt(worst) / (least * (1 - decay)) < window))
    return
  end
  hops = 1 / restoring(f) + s.eta / restoring(-f);
  rest = 2 * w * hops / (1 - s.eta ^ 2) / s.p;
end

function d = rhs(t, x, s, side)
  global count
  count += 1;
  k = floor(t / s.dt) + 1;
  f = 0;
  if (k <= numel(s.slope))
    f = s.f(k) + s.slope(k) * (t - (k - 1) * s.dt);
  end
  y = s.alpha - x(1);
  d = [x(2); -s.p ^ 2 * (sin(y) + side * f * cos(y))];
end

function [value, stops, direction] = events(t, x, s)
  value = [x(1); x(1) - s.alpha; x(2)];
  stops = [1; 1; 0];
  direction = [-1; 1; -1];
end

function [kind, t, w, top] = flight(s, t, side, w, rtol)
  x = [0; w];
  top = 0;
  step = 0.1 * s.dt;
  if (w != 0)
    step = min(0.2 * abs(w) / (s.p ^ 2 * s.alpha), s.dt);
  end
  for last = [s.end, s.end + 60]
    if (!(t < last))
      continue
    end
    options = odeset("RelTol", rtol, "AbsTol", rtol * s.alpha, ...
      "InitialStep", min(step, last - t), "MaxStep", s.dt, "Refine", 1, ...
      "Events", @(t, x) events(t, x, s));
    [ts, xs, te, xe, ie] = ode45(@(t, x) rhs(t, x, s, side), [t, last], ...
      x, options);
    top = max([top; xs(:, 1)]);
    if (!isempty(ie))
      top = max([top; xe(ie == 3, 1)]);
      % Turning points are seen, too; what ended the flight is the last.
      if (ie(end) == 2)
        kind = "overturned";
        t = te(end);
        return
      elseif (ie(end) == 1)
        kind = "impact";
        t = te(end);
        w = xe(end, 2);
        return
      end
    end
    t = last;
    x = xs(end, :)';
    step = s.dt;
  end
  kind = "still";
end

function [peak, impacts] = run(s, rtol)
  peak = 0;
  impacts = [];
  t = 0;
  while (true)
    [t, sign_f] = exceedance(s, t);
    if (sign_f == 0)
      break
    end
    side = -sign_f;
    w = 0;
    while (true)
      [kind, t, w, top] = flight(s, t, side, w, rtol);
      peak = max(peak, top);
      if (strcmp(kind, "overturned"))
        peak = Inf;
        return
      elseif (!strcmp(kind, "impact"))
        peak = NaN;
        return
      elseif (t > s.end)
        peak /= s.alpha;
        return
      end
      impacts(end + 1) = t;
      side = -side;
      w *= -s.eta;
      rest = chatter(s, t, side, w);
      if (!isempty(rest))
        t += rest;
        break
      end
    end
  end
  peak /= s.alpha;
end

function f = shaking(pieces, t)
  k = find(t < pieces.t1, 1);
  if (isempty(k))
    k = numel(pieces.t1);
  end
  [a, b, c] = deal(pieces.a(k), pieces.b(k), pieces.c(k));
  switch pieces.kind{k}
    case "line"
      f = a + b * (t - pieces.t0(k));
    case "sine"
      f = a * sin(b * t);
    case "cosine"
      f = a * cos(b * t);
    otherwise
      square = (b * (t - c)) ^ 2;
      f = a * (1 - square) * exp(-square / 2);
  end
end

function d = served_rhs(t, x, s)
  f = s.side * shaking(s.pieces, t);
  y = s.alpha - x(1);
  if (s.linear)
    d = [x(2); -s.p ^ 2 * (y + f)];
  else
    d = [x(2); -s.p ^ 2 * (sin(y) + f * cos(y))];
  end
end

% From the last step before `guess` on to where component k of x has the
% value `level`, by Newton's method: Octave's own event is a linear interpolation.
function [t, x] = polished(rhs, options, ts, xs, guess, x, k, level)
  from = find(ts < guess, 1, "last");
  t = guess;
  if (isempty(from))
    return
  end
  t = ts(from);
  x = xs(from, :)';
  for turn = 1:8
    step = guess - t;
    if (step == 0)
      return
    end
    options = odeset(options, "InitialStep", abs(step));
    [~, xs] = ode45(rhs, [t, guess], x, options);
    t = guess;
    x = xs(end, :)';
    slope = rhs(t, x)(k);
    guess = t + (level - x(k)) / slope;
    if (abs(guess - t) < 2 * eps(t))
      return
    end
  end
end

function s = request(line)
  word = strsplit(line, " ");
  x = num2cell(str2double(word(1:10)));
  [s.alpha, s.p, s.linear, s.limit, s.side, s.t, s.u, s.w, s.stop, n] = x{:};
  rows = reshape(word(11:end), 6, n);
  number = @(k) str2double(rows(k, :));
  s.pieces = struct("t0", number(1), "t1", number(2), "a", number(4), ...
    "b", number(5), "c", number(6));
  s.pieces.kind = rows(3, :);
end

function answer(s, best)
  rhs = @(t, x) served_rhs(t, x, s);
  crossed = @(t, x) deal([x(1); x(1) - s.limit; x(2)], [1; 1; 0], [-1; 1; -1]);
  options = odeset();
  if (best)
    step = 1e-3;
    if (s.w != 0)
      step = min(0.2 * abs(s.w) / (s.p ^ 2 * s.alpha), 1e-2);
    end
    options = odeset("RelTol", 1e-10, "AbsTol", 1e-15, "MaxStep", 2e-2, ...
      "InitialStep", min(step, s.stop - s.t), "Refine", 1);
  end
  [ts, xs, te, xe, ie] = ode45(rhs, [s.t, s.stop], [s.u; s.w], ...
    odeset(options, "Events", crossed));
  names = {"impact", "overturned", "stop"};
  kind = 3;
  t = ts(end);
  x = xs(end, :)';
  if (!isempty(ie) && ie(end) < 3)
    kind = ie(end);
    t = te(end);
    x = xe(end, :)';
    if (best)
      [t, x] = polished(rhs, options, ts, xs, t, x, 1, ...
        (kind == 2) * s.limit);
    end
  end
  [top, k] = max(xs(:, 1));
  top_t = ts(k);
  for turn = find(ie(:)' == 3)
    at = te(turn);
    high = xe(turn, :)';
    if (best)
      [at, high] = polished(rhs, options, ts, xs, at, high, 2, 0);
    end
    if (high(1) > top || best)
      top = high(1);
      top_t = at;
    end
  end
  printf("%s %.17g %.17g %.17g %.17g %.17g\n", names{kind}, t, x, top, top_t);
  fflush(stdout);
end

global count
warning("off", "all");
folder = argv(){1};
if (strcmp(folder, "serve"))
  % `fgetl` waits for the line after; `input` fails at the end.
  try
    while (true)
      answer(request(input("", "s")), strcmp(argv(){2}, "best"));
    end
  catch problem
    if (isempty(strfind(problem.message, "user-input failed")))
      fprintf(stderr, "%s\n", problem.message);
    end
  end
  exit
end
printf("tool,version,method,setting,case,cpu_s,work,peak_ratio,impacts,first_impacts_s\n");
paths = sort(glob(fullfile(folder, "*.txt")));
% Every third case; at 1e-9 an analysis takes most of a minute.
for rtol = [1e-3, 1e-6]
  for i = 1:3:numel(paths)
    s = read_scene(paths{i});
    count = 0;
    begin = cputime();
    [peak, impacts] = run(s, rtol);
    took = cputime() - begin;
    first = sprintf("%.17g ", impacts(1:min(10, end)));
    printf("GNU Octave,%s,ode45,rtol %.0e,%s,%.9g,%d,%.17g,%d,%s\n", ...
      version(), rtol, s.name, took, count, peak, numel(impacts), ...
      strtrim(first));
    fflush(stdout);
  end
end
